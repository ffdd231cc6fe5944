// The style and the script of a batch's page: a grid of overlays that is shown page by page.
#pragma once

namespace edgescout {

inline constexpr const char* GALLERY_STYLE = R"(
.histogram{display:block;width:100%;height:auto}.bar{fill:#2b6cb0}.axis{stroke:#98a2b0;fill:none}
.count{font-size:11px;fill:#64707f;text-anchor:middle}.histogram .tick{font-size:12px}
.row>section{margin:0}.row{margin:0 0 20px}
.stages td{border:0;padding:3px 12px 3px 0}.stages td:last-child{width:55%;padding-right:0}
.figure{text-align:right}th.figure{text-align:right}
.length{display:block;height:12px;min-width:1px;background:#2b6cb0;border-radius:3px}
.controls,.pager{display:flex;flex-wrap:wrap;gap:10px;align-items:center;margin:0 0 14px}
.pager{margin:0}.pager[hidden]{display:none}.controls .pager{margin-left:auto}
.controls input,.controls select,.pager button,.pager input{font:inherit;padding:4px 10px;border:1px solid var(--line);border-radius:8px;background:#fff;color:var(--ink)}
.controls #find{width:210px}.pager input{width:70px;text-align:right}
.pager button{cursor:pointer}.pager button:disabled{opacity:.4;cursor:default}
.grid{display:grid;grid-template-columns:repeat(auto-fill,minmax(200px,1fr));gap:16px;margin-bottom:16px}
.card{border:1px solid var(--line);border-radius:10px;overflow:hidden;background:#fff;min-width:0}
.card .view{display:flex;align-items:center;justify-content:center;aspect-ratio:4/3;background:#eef1f5;color:var(--soft);font-size:13px;overflow:hidden;text-decoration:none}
.card img{width:100%;height:100%;object-fit:contain;display:block}
.card p{margin:0;padding:8px 12px;font-size:13px;color:var(--soft)}
.card p b{display:block;color:var(--ink);overflow:hidden;text-overflow:ellipsis;white-space:nowrap}
.card p a{color:inherit}
.card.bad{border-color:#f0b4b4}.card.bad .view{background:#fff5f5;color:#a32020;padding:12px;align-items:flex-start;justify-content:flex-start;overflow:auto;overflow-wrap:anywhere}
)";

inline constexpr const char* GALLERY_CONTROLS =
    "<div class=controls><input id=find type=search placeholder='Part of a name' "
    "aria-label='Part of a name'><select id=order aria-label='Order'><option value=failed>Failures "
    "first, as listed<option value=least>Failures first, then the least probable<option "
    "value=most>Most poses first<option value=slow>Slowest first</select><div "
    "class=pager></div></div>";

inline constexpr const char* GALLERY_SCRIPT = R"(
const data=JSON.parse(document.getElementById('data').textContent),perPage=50;
const [NAME,FOLDER,STATE,POSES,BEST,SECONDS,MESSAGE,OVERLAY,NUMBER]=[0,1,2,3,4,5,6,7,8];
data.images.forEach((i,n)=>i[NUMBER]=n);
const find=document.getElementById('find'),order=document.getElementById('order'),grid=document.getElementById('grid');
const bad=i=>i[STATE]>0?0:1;
const orders={failed:null,least:(a,b)=>bad(a)-bad(b)||a[BEST]-b[BEST],most:(a,b)=>b[POSES]-a[POSES],slow:(a,b)=>b[SECONDS]-a[SECONDS]};
let chosen=[],page=0;
const make=(tag,fields,...children)=>{const e=Object.assign(document.createElement(tag),fields);e.append(...children);return e};
const link=(i,ending)=>[...(data.folders[i[FOLDER]]||'').split('/').filter(s=>s),i[NAME]+ending].map(encodeURIComponent).join('/');
function card(i){
  const name=make('b',{textContent:i[NAME],title:i[NAME]});
  if(i[STATE]>0)return make('div',{className:'card bad'},make('div',{className:'view',textContent:i[MESSAGE]}),make('p',{},name,i[STATE]==1?'failed':'missing'));
  const overlay=link(i,'_overlay.png'),thumbnail=document.getElementById('picture'+i[NUMBER]);
  const view=i[OVERLAY]?make('a',{className:'view',href:overlay,title:overlay}):make('div',{className:'view',textContent:'no overlay'});
  if(i[OVERLAY])view.append(make('img',{alt:'',loading:'lazy',src:thumbnail?'data:image/jpeg;base64,'+thumbnail.textContent:overlay,onerror(){view.textContent='not in this page'}}));
  const poses=i[POSES]==0?'no pose':i[POSES]+(i[POSES]==1?' pose':' poses')+', best '+i[BEST].toFixed(2);
  return make('div',{className:'card'},view,make('p',{},name,poses+' · '+i[SECONDS].toFixed(2)+' s · ',make('a',{href:link(i,'.json'),textContent:'json'})));
}
function show(to){
  const pages=Math.max(1,Math.ceil(chosen.length/perPage));
  page=Math.min(Math.max(0,to),pages-1);
  grid.replaceChildren(...chosen.slice(page*perPage,(page+1)*perPage).map(card));
  const first=page*perPage+1,last=Math.min(chosen.length,first+perPage-1);
  document.getElementById('shown').textContent=chosen.length?[first,last].join(' to ')+' of '+chosen.length.toLocaleString('en'):'none';
  for(const bar of document.querySelectorAll('.pager')){
    const button=(text,to,off)=>make('button',{textContent:text,disabled:off,onclick(){show(to)}});
    const number=make('input',{type:'number',min:1,max:pages,value:page+1,ariaLabel:'Page',onchange(){show(Number(this.value)-1)}});
    bar.hidden=pages==1;
    bar.replaceChildren(button('Back',page-1,page==0),number,'of '+pages,button('Next',page+1,page==pages-1));
  }
}
function choose(){
  const part=find.value.toLowerCase();
  chosen=data.images.filter(i=>i[NAME].toLowerCase().includes(part));
  if(orders[order.value])chosen.sort(orders[order.value]);
  show(0);
}
find.oninput=order.onchange=choose;
choose();
)";

}  // namespace edgescout
